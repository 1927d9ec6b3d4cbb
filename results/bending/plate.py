"""A thin quadrilateral plate by Ritz with monomials: its stiffness in a saddle, stress, and the volume under it clamped."""
import numpy as np
def quad(corners, u, v):
    c=np.asarray(corners,float); N=[(1-u)*(1-v)/4,(1+u)*(1-v)/4,(1+u)*(1+v)/4,(1-u)*(1+v)/4]
    return sum(n[...,None]*x for n,x in zip(N,c))
def monomials(u,v,deg):
    """value, u, v, uu, uv, vv derivs of u^a v^b"""
    out=[]
    for a in range(deg+1):
        for b in range(deg+1):
            pu=[u**a, a*u**(a-1) if a>0 else 0*u, a*(a-1)*u**(a-2) if a>1 else 0*u]
            pv=[v**b, b*v**(b-1) if b>0 else 0*v, b*(b-1)*v**(b-2) if b>1 else 0*v]
            out.append([pu[0]*pv[0],pu[1]*pv[0],pu[0]*pv[1],pu[2]*pv[0],pu[1]*pv[1],pu[0]*pv[2]])
    return np.array(out)  # n,6,pts
def curv(corners,u,v,deg):
    c=np.asarray(corners,float)
    m=monomials(u,v,deg)
    au=((-(1-v))[:,None]*c[0]+(1-v)[:,None]*c[1]+(1+v)[:,None]*c[2]-(1+v)[:,None]*c[3])/4
    av=((-(1-u))[:,None]*c[0]-(1+u)[:,None]*c[1]+(1+u)[:,None]*c[2]+(1-u)[:,None]*c[3])/4
    auv=(c[0]-c[1]+c[2]-c[3])/4
    J=np.stack([au,av],1) # pts,2(uv),2(xy)
    det=J[:,0,0]*J[:,1,1]-J[:,0,1]*J[:,1,0]
    Ji=np.linalg.inv(J)   # xy<-uv: grad_xy = Ji grad_uv
    g=np.einsum('pij,njp->nip',Ji,m[:,1:3])
    # H_uv = J H J^T + grad_xy . x_uv (only uv)
    Huu=m[:,3];Huv=m[:,4]-np.einsum('nip,i->np',g,auv);Hvv=m[:,5]
    H=np.stack([np.stack([Huu,Huv],1),np.stack([Huv,Hvv],1)],1) # n,2,2,p
    Hxy=np.einsum('pij,njkp,plk->nilp',Ji,H,Ji)
    return np.stack([Hxy[:,0,0],Hxy[:,1,1],2*Hxy[:,0,1]],1),det,m[:,0]
def solve(corners,straight,nu,deg):
    c=np.asarray(corners,float)
    x,w=np.polynomial.legendre.leggauss(deg+3)
    U,V=[a.ravel() for a in np.meshgrid(x,x)]; W=np.outer(w,w).ravel()
    k,det,_=curv(c,U,V,deg)
    D=np.array([[1,nu,0],[nu,1,0],[0,0,(1-nu)/2]])
    K=np.einsum('nip,ij,mjp,p->nm',k,D,k,W*det)
    # constraints: corners given (w = lam/sum lam^2), straight edges linear
    tri=lambda a,b,d:((b-a)[0]*(d-a)[1]-(b-a)[1]*(d-a)[0])
    area=((c[2]-c[0])[0]*(c[3]-c[1])[1]-(c[2]-c[0])[1]*(c[3]-c[1])[0])/2
    lam=np.array([(-1)**i*tri(c[(i+1)%4],c[(i+2)%4],c[(i+3)%4])/area for i in range(4)])
    wc=lam/(lam@lam)
    rows=[];rhs=[]
    cu=[(-1,-1),(1,-1),(1,1),(-1,1)]
    for i in range(4):
        ts=np.linspace(0,1,deg+1) if straight[i] else np.array([0.])
        a=np.array(cu[i],float);b=np.array(cu[(i+1)%4],float)
        for t in ts:
            p=a+t*(b-a); rows.append(monomials(np.array([p[0]]),np.array([p[1]]),deg)[:,0,0]); rhs.append(wc[i]+t*(wc[(i+1)%4]-wc[i]))
    A=np.array(rows);rhs=np.array(rhs)
    x0=np.linalg.lstsq(A,rhs,rcond=None)[0]
    u_,s,vt=np.linalg.svd(A); Z=vt[(s>1e-10).sum():].T
    y=-np.linalg.lstsq(Z.T@K@Z,Z.T@(K@x0),rcond=1e-14)[0] if Z.shape[1] else np.zeros(0)
    coef=x0+Z@y
    return coef@K@coef, coef, area
def mises(corners,coef,nu,deg,u,v):
    k,_,_=curv(corners,u,v,deg); b=np.einsum('n,nip->ip',coef,k)
    x=b[0]+nu*b[1];y=b[1]+nu*b[0];xy=(1-nu)/2*b[2]
    return np.sqrt(x*x-x*y+y*y+3*xy*xy)
def area(c): c=np.asarray(c); return ((c[2]-c[0])[0]*(c[3]-c[1])[1]-(c[2]-c[0])[1]*(c[3]-c[1])[0])/2
def volume_clamped(corners, extra):
    """Largest of int w - int (Lap w)^2/2 *2..., w = bubble * monomials"""
    x,w=np.polynomial.legendre.leggauss(14); U,V=[a.ravel() for a in np.meshgrid(x,x)];W=np.outer(w,w).ravel()
    deg=4+extra
    k,det,val=curv(corners,U,V,deg)
    idx=lambda a,b:a*(deg+1)+b
    F=[];f=[1,0,-2,0,1]
    for a in range(extra+1):
        for b in range(extra+1):
            co=np.zeros((deg+1)**2)
            for i in range(5):
                for j in range(5): co[idx(a+i,b+j)]+=f[i]*f[j]
            F.append(co)
    F=np.array(F); lap=F@(k[:,0]+k[:,1]); v=F@val
    K=np.einsum('ap,bp,p->ab',lap,lap,W*det); b=v@(W*det)
    return b@np.linalg.solve(K,b)
