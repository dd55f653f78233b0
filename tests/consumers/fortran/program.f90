! The interface from Fortran: every procedure is called, and what it gives is checked. Argument: a resource.

! v = c rho u, c from the context; counts its points there
      subroutine scaled_mass(ctx,q,u1,u2,u3,u4,u5,u6,u7,u8,u9,u10,u11,u12,u13,u14,&
&           u15,u16,v1,v2,v3,v4,v5,v6,v7,v8,v9,v10,v11,v12,v13,v14,v15,v16,ierr)
      real*8 ctx(2),u1(*),u2(*),v1(*)
      integer q,ierr,i
      do i=1,q
        v1(i)=ctx(1)*u1(i)*u2(i)
      enddo
      ctx(2)=ctx(2)+q
      ierr=0
      end

! rho = w dx
      subroutine set_up(ctx,q,u1,u2,u3,u4,u5,u6,u7,u8,u9,u10,u11,u12,u13,u14,&
&           u15,u16,v1,v2,v3,v4,v5,v6,v7,v8,v9,v10,v11,v12,v13,v14,v15,v16,ierr)
      real*8 ctx(*),u1(*),u2(*),v1(*)
      integer q,ierr,i
      do i=1,q
        v1(i)=u1(i)*u2(i)
      enddo
      ierr=0
      end

      subroutine fails(ctx,q,u1,u2,u3,u4,u5,u6,u7,u8,u9,u10,u11,u12,u13,u14,&
&           u15,u16,v1,v2,v3,v4,v5,v6,v7,v8,v9,v10,v11,v12,v13,v14,v15,v16,ierr)
      real*8 ctx(*)
      integer q,ierr
      ierr=7
      end

      subroutine expect(got,want,what)
      real*8 got,want
      character*(*) what
      if (.not.(abs(got-want)<=1.d-12*max(1.d0,abs(want)))) then
        write(*,*) what,' is ',got,'; expected ',want
        stop 1
      endif
      end

      subroutine done(err,what)
      integer err
      character*(*) what
      if (err/=0) then
        write(*,*) what,' failed with code ',err
        stop 1
      endif
      end

      program consumer
      implicit none
      include 'ceed/fortran.h'
      integer, parameter :: nelem=5,p=3,q=4,nx=nelem+1,nu=nelem*(p-1)+1
      integer ceed,err,i,j,n,mtype,deterministic,request
      integer x,y,z,rx,ru,rq,rb,ro,rc,r2,r3,r4,bx,bu,bh1,bdiv,bcurl,bt,blin,bctof
      integer qf_setup,qf_mass,qf_name,qf_id,qf_bad,ctx,op_setup,op_mass,op_all,op_name,op_inv,op_bad
      integer op_c,op_p,op_r,qdata,u,v,assembled,rassembled,diagonal,mult,rcoarse,xr
      integer xind(2*nelem),uind(p*nelem),strides(3),layout(3),cind(2*nelem)
      integer*8 offset
      integer*1 curl(3*2*nelem)
      logical*1 orients(2*nelem)
      real*8 a(nu),nodes(nx),one(1),norm,total,points(q),weights(q),ctxdata(2),colo(q*q),tri(3),trig(6),refs(2),w(1)
      real*8 hdiv(2*3),div(3),interp1d(4),grad1d(4),q1d(2),w1d(2),ctof(p*2),first
      character arg*64
      external scaled_mass,set_up,fails

      call getarg(1,arg)
      call ceedinit(trim(arg),ceed,err)
      call done(err,'ceedinit')
      call ceedgetpreferredmemtype(ceed,mtype,err)
      if (mtype/=ceed_mem_host.and.mtype/=ceed_mem_device) stop 2
      call ceedisdeterministic(ceed,deterministic,err)
      if (deterministic/=0.and.deterministic/=1) stop 3
      call ceedsetnumviewtabs(ceed,1,err)
      call ceedview(ceed,err)
      call done(err,'ceedview')
      request=ceed_request_immediate
      call ceedrequestwait(request,err)
      call done(err,'ceedrequestwait')

! Vectors
      call ceedvectorcreate(ceed,4,x,err)
      a=0
      do i=1,4
        a(i)=-i
      enddo
      offset=0
      call ceedvectorsetarray(x,ceed_mem_host,ceed_use_pointer,a,offset,err)
      call done(err,'ceedvectorsetarray')
      call ceedvectornorm(x,ceed_norm_1,norm,err)
      call expect(norm,10.d0,'1-norm')
      call ceedvectornorm(x,ceed_norm_max,norm,err)
      call expect(norm,4.d0,'max-norm')
      call ceedvectorreciprocal(x,err)
      call ceedvectorsyncarray(x,ceed_mem_host,err)
      call expect(a(4),-0.25d0,'reciprocal')
      call ceedvectorgetarray(x,ceed_mem_host,one,offset,err)
      one=0
      call set_entry(one,offset,2,8.d0)
      call ceedvectorrestorearray(x,one,offset,err)
      call done(err,'ceedvectorrestorearray')
      if (offset/=0) stop 4
      call ceedvectorgetarrayread(x,ceed_mem_host,a,offset,err)
      call expect(a(2+offset),8.d0,'entry 2')
      call ceedvectorrestorearrayread(x,a,offset,err)
      call ceedvectortakearray(x,ceed_mem_host,a,offset,err)
      if (offset/=0) stop 5
      call expect(a(2),8.d0,'entry 2 of the lent array')
      call ceedvectorcreate(ceed,3,y,err)
      call ceedvectorsetvalue(y,2.5d0,err)
      call ceedvectorgetarraywrite(y,ceed_mem_host,one,offset,err)
      do i=1,3
        call set_entry(one,offset,i,1.d0*i)
      enddo
      call ceedvectorrestorearray(y,one,offset,err)
      call ceedvectornorm(y,ceed_norm_2,norm,err)
      call expect(norm,sqrt(14.d0),'2-norm')
      call ceedvectorsetnumviewtabs(y,1,err)
      call ceedvectorview(y,err)
      call done(err,'ceedvectorview')
      call ceedvectordestroy(x,err)
      if (x/=ceed_null) stop 6
      call ceedvectordestroy(x,err)
      call done(err,'destroying what is destroyed')
      call ceedvectorsetvalue(999,1.d0,err)
      if (err==0) stop 7

! Quadrature
      call ceedgaussquadrature(q,points,weights,err)
      call expect(sum(weights*points**6),2.d0/7.d0,'integral of x**6')
      call ceedlobattoquadrature(q,points,weights,err)
      call expect(points(1),-1.d0,'first Lobatto point')
      call expect(sum(weights),2.d0,'length')

! Restrictions
      do i=1,nelem
        xind(2*i-1)=i-1
        xind(2*i)=i
        cind(2*i-1)=i-1
        cind(2*i)=i
        do j=1,p
          uind(p*(i-1)+j)=(i-1)*(p-1)+j-1
        enddo
      enddo
      call ceedelemrestrictioncreate(ceed,nelem,2,1,1,nx,ceed_mem_host,ceed_use_pointer,xind,rx,err)
      call done(err,'ceedelemrestrictioncreate')
      call ceedelemrestrictioncreate(ceed,nelem,p,1,1,nu,ceed_mem_host,ceed_copy_values,uind,ru,err)
      strides=[1,q,q]
      call ceedelemrestrictioncreatestrided(ceed,nelem,q,1,q*nelem,strides,rq,err)
      call done(err,'ceedelemrestrictioncreatestrided')
      strides=ceed_strides_backend
      call ceedelemrestrictioncreatestrided(ceed,nelem,q,1,q*nelem,strides,r4,err)
      call done(err,'ceedelemrestrictioncreatestrided, strides of the backend')
      call ceedelemrestrictioncreateblocked(ceed,nelem,2,8,1,1,nx,ceed_mem_host,ceed_use_pointer,xind,rb,err)
      call done(err,'ceedelemrestrictioncreateblocked')
      orients=.false.
      orients(2)=.true.
      call ceedelemrestrictioncreateoriented(ceed,nelem,2,1,1,nx,ceed_mem_host,ceed_copy_values,xind,orients,ro,err)
      call done(err,'ceedelemrestrictioncreateoriented')
      curl=0
      do i=1,2*nelem
        curl(3*i-1)=2
      enddo
      call ceedelemrestrictioncreatecurloriented(ceed,nelem,2,1,1,nx,ceed_mem_host,ceed_copy_values,xind,curl,rc,err)
      call done(err,'ceedelemrestrictioncreatecurloriented')
      nodes=1
      call ceedvectorcreate(ceed,nx,x,err)
      offset=0
      call ceedvectorsetarray(x,ceed_mem_host,ceed_copy_values,nodes,offset,err)
      call ceedvectorcreate(ceed,2*nelem,z,err)
      call ceedelemrestrictionapply(ro,ceed_notranspose,x,z,ceed_request_immediate,err)
      call vector_sum(z,2*nelem,total)
      call expect(total,2.d0*nelem-2,'sum of an oriented E-vector')
      call ceedelemrestrictionapply(rc,ceed_notranspose,x,z,ceed_request_immediate,err)
      call vector_sum(z,2*nelem,total)
      call expect(total,4.d0*nelem,'sum of a curl-oriented E-vector')
      call ceedvectordestroy(z,err)
      call ceedvectorcreate(ceed,16,z,err)
      call ceedelemrestrictionapplyblock(rb,0,ceed_notranspose,x,z,ceed_request_immediate,err)
      call done(err,'ceedelemrestrictionapplyblock')
      call vector_sum(z,16,total)
      call expect(total,16.d0,'sum of a block')
      call ceedelemrestrictioncreateblockedoriented(ceed,nelem,2,4,1,1,nx,ceed_mem_host,ceed_copy_values,xind,orients,r2,err)
      call done(err,'ceedelemrestrictioncreateblockedoriented')
      call ceedelemrestrictioncreateblockedcurloriented(ceed,nelem,2,4,1,1,nx,ceed_mem_host,ceed_copy_values,xind,curl,r3,err)
      call done(err,'ceedelemrestrictioncreateblockedcurloriented')
      call ceedelemrestrictionview(r3,err)
      call ceedelemrestrictiondestroy(r2,err)
      call ceedelemrestrictiondestroy(r3,err)
      call ceedelemrestrictioncreateblockedstrided(ceed,nelem,2,2,1,nelem*2,[1,nelem,2],r2,err)
      call done(err,'ceedelemrestrictioncreateblockedstrided')
      call ceedelemrestrictiongetelayout(rx,layout,err)
      if (any(layout/=[1,2,2])) stop 8
      call ceedvectorcreate(ceed,nx,mult,err)
      call ceedelemrestrictiongetmultiplicity(rx,mult,err)
      call vector_sum(mult,nx,total)
      call expect(total,2.d0*nelem,'sum of multiplicities')
      call ceedelemrestrictionsetnumviewtabs(rx,1,err)
      call ceedelemrestrictionview(rx,err)
      call done(err,'ceedelemrestrictionview')

! Bases
      call ceedbasiscreatetensorh1lagrange(ceed,1,1,2,q,ceed_gauss,bx,err)
      call ceedbasiscreatetensorh1lagrange(ceed,1,1,p,q,ceed_gauss,bu,err)
      call ceedbasisgetnumnodes(bu,n,err)
      if (n/=p) stop 9
      call ceedbasisgetnumquadraturepoints(bu,n,err)
      if (n/=q) stop 10
      call ceedbasisgetinterp1d(bu,a,offset,err)
      total=0
      do i=1,p*q
        total=total+a(i+offset)
      enddo
      call expect(total,1.d0*q,'sum of interp1d')
      call ceedbasisgetgrad1d(bu,a,offset,err)
      total=0
      do i=1,p*q
        total=total+a(i+offset)
      enddo
      call expect(total,0.d0,'sum of grad1d')
      call ceedbasisgetqref(bu,a,offset,err)
      first=a(1+offset)
      call ceedgaussquadrature(q,points,weights,err)
      call expect(first,points(1),'first quadrature point')
      call ceedbasisgetcollocatedgrad(bu,colo,err)
      call expect(sum(colo),0.d0,'sum of the collocated gradient')
      call ceedbasissetnumviewtabs(bu,1,err)
      call ceedbasisview(bu,err)
      call done(err,'ceedbasisview')
      tri=1.d0/3
      trig=[-1.d0,1.d0,0.d0,-1.d0,0.d0,1.d0]
      refs=1.d0/3
      w=0.5d0
      call ceedbasiscreateh1(ceed,ceed_triangle,1,3,1,tri,trig,refs,w,bh1,err)
      call done(err,'ceedbasiscreateh1')
      call ceedvectordestroy(x,err)
      call ceedvectorcreate(ceed,1,x,err)
      call ceedbasisapply(bh1,1,ceed_notranspose,ceed_eval_interp,y,x,err)
      call done(err,'ceedbasisapply')
      call vector_sum(x,1,total)
      call expect(total,2.d0,'the mean of the nodes')
      hdiv=1
      div=1
      call ceedbasiscreatehdiv(ceed,ceed_triangle,1,3,1,hdiv,div,refs,w,bdiv,err)
      call done(err,'ceedbasiscreatehdiv')
      call ceedbasiscreatehcurl(ceed,ceed_triangle,1,3,1,hdiv,div,refs,w,bcurl,err)
      call done(err,'ceedbasiscreatehcurl')
      call ceedlobattoquadrature(2,q1d,w1d,err)
      interp1d=[1.d0,0.d0,0.d0,1.d0]
      grad1d=[-0.5d0,0.5d0,-0.5d0,0.5d0]
      call ceedbasiscreatetensorh1(ceed,1,1,2,2,interp1d,grad1d,q1d,w1d,bt,err)
      call done(err,'ceedbasiscreatetensorh1')

! QFunctions
      call ceedqfunctioncreateinterior(ceed,1,set_up,'program.f90:set_up',qf_setup,err)
      call done(err,'ceedqfunctioncreateinterior')
      call ceedqfunctionaddinput(qf_setup,'weight',1,ceed_eval_weight,err)
      call ceedqfunctionaddinput(qf_setup,'dx',1,ceed_eval_grad,err)
      call ceedqfunctionaddoutput(qf_setup,'rho',1,ceed_eval_none,err)
      call done(err,'ceedqfunctionaddoutput')
      call ceedqfunctioncreateinterior(ceed,1,scaled_mass,'program.f90:scaled_mass'//char(0),qf_mass,err)
      call ceedqfunctionaddinput(qf_mass,'u',1,ceed_eval_interp,err)
      call ceedqfunctionaddinput(qf_mass,'rho',1,ceed_eval_none,err)
      call ceedqfunctionaddoutput(qf_mass,'v',1,ceed_eval_interp,err)
      call ceedqfunctioncontextcreate(ceed,ctx,err)
      ctxdata=[3.d0,0.d0]
      offset=0
      call ceedqfunctioncontextsetdata(ctx,ceed_mem_host,ceed_copy_values,2,ctxdata,offset,err)
      call done(err,'ceedqfunctioncontextsetdata')
      call ceedqfunctionsetcontext(qf_mass,ctx,err)
      call done(err,'ceedqfunctionsetcontext')
      call ceedqfunctioncontextsetnumviewtabs(ctx,1,err)
      call ceedqfunctioncontextview(ctx,err)
      call done(err,'ceedqfunctioncontextview')
      call ceedqfunctionsetnumviewtabs(qf_mass,1,err)
      call ceedqfunctionview(qf_mass,err)
      call done(err,'ceedqfunctionview')
      call ceedqfunctioncreateidentity(ceed,1,ceed_eval_interp,ceed_eval_interp,qf_id,err)
      call done(err,'ceedqfunctioncreateidentity')
      call ceedqfunctioncreateinteriorbyname(ceed,'MassApply',qf_name,err)
      call done(err,'ceedqfunctioncreateinteriorbyname')
      call ceedvectorcreate(ceed,3,u,err)
      call ceedvectorcreate(ceed,3,v,err)
      call ceedvectorsetvalue(u,2.d0,err)
      n=ceed_null
      call ceedqfunctionapply(qf_name,3,y,u,n,n,n,n,n,n,n,n,n,n,n,n,n,n,v,n,n,n,n,n,n,n,n,n,n,n,n,n,n,n,err)
      call done(err,'ceedqfunctionapply')
      call vector_sum(v,3,total)
      call expect(total,12.d0,'2 (1 + 2 + 3)')
      call ceedvectordestroy(u,err)
      call ceedvectordestroy(v,err)

! Operators: the mass of [0, 1] times 3
      call ceedoperatorcreate(ceed,qf_setup,ceed_qfunction_none,ceed_qfunction_none,op_setup,err)
      call ceedoperatorcreate(ceed,qf_mass,ceed_qfunction_none,ceed_qfunction_none,op_mass,err)
      call done(err,'ceedoperatorcreate')
      call ceedvectorcreate(ceed,nelem*q,qdata,err)
      call ceedoperatorsetfield(op_setup,'weight',ceed_elemrestriction_none,bx,ceed_vector_none,err)
      call ceedoperatorsetfield(op_setup,'dx',rx,bx,ceed_vector_active,err)
      call ceedoperatorsetfield(op_setup,'rho',rq,ceed_basis_none,ceed_vector_active,err)
      call done(err,'ceedoperatorsetfield')
      call ceedoperatorsetfield(op_mass,'u',ru,bu,ceed_vector_active,err)
      call ceedoperatorsetfield(op_mass,'rho',rq,ceed_basis_none,qdata,err)
      call ceedoperatorsetfield(op_mass,'v',ru,bu,ceed_vector_active,err)
      call done(err,'ceedoperatorsetfield')
      do i=1,nx
        nodes(i)=(i-1.d0)/nelem
      enddo
      call ceedvectorcreate(ceed,nx,xr,err)
      offset=0
      call ceedvectorsetarray(xr,ceed_mem_host,ceed_use_pointer,nodes,offset,err)
      call ceedoperatorapply(op_setup,xr,qdata,ceed_request_immediate,err)
      call done(err,'ceedoperatorapply')
      call ceedvectorcreate(ceed,nu,u,err)
      call ceedvectorcreate(ceed,nu,v,err)
      call ceedvectorsetvalue(u,1.d0,err)
      call ceedoperatorapply(op_mass,u,v,ceed_request_immediate,err)
      call vector_sum(v,nu,total)
      call expect(total,3.d0,'3 times the length')
      call ceedqfunctioncontextgetdata(ctx,ceed_mem_host,a,offset,err)
      call expect(a(2+offset),1.d0*nelem*q,'points that the subroutine counted')
      call ceedqfunctioncontextrestoredata(ctx,a,offset,err)
      call done(err,'ceedqfunctioncontextrestoredata')
      call ceedoperatorapplyadd(op_mass,u,v,ceed_request_immediate,err)
      call vector_sum(v,nu,total)
      call expect(total,6.d0,'twice that')
      call ceedoperatorlinearassemblediagonal(op_mass,v,ceed_request_immediate,err)
      call done(err,'ceedoperatorlinearassemblediagonal')
      call vector_sum(v,nu,total)
      call expect(total,2.4d0,'3 times the trace of the mass matrix')
      call ceedoperatorlinearassembleqfunction(op_mass,assembled,rassembled,ceed_request_immediate,err)
      call done(err,'ceedoperatorlinearassembleqfunction')
      call vector_sum(assembled,nelem*q,total)
      call expect(total,3.d0,'sum of the assembled QFunction')

! A composite of it and of the gallery's
      call ceedoperatorcreate(ceed,qf_name,ceed_qfunction_none,ceed_qfunction_none,op_name,err)
      call ceedoperatorsetfield(op_name,'u',ru,bu,ceed_vector_active,err)
      call ceedoperatorsetfield(op_name,'qdata',rq,ceed_basis_none,qdata,err)
      call ceedoperatorsetfield(op_name,'v',ru,bu,ceed_vector_active,err)
      call ceedoperatorcreatecomposite(ceed,op_all,err)
      call ceedoperatorcompositeaddsub(op_all,op_mass,err)
      call ceedoperatorcompositeaddsub(op_all,op_name,err)
      call done(err,'ceedoperatorcompositeaddsub')
      call ceedoperatorapply(op_all,u,v,ceed_request_ordered,err)
      call vector_sum(v,nu,total)
      call expect(total,4.d0,'the composite')
      call ceedoperatorsetname(op_all,'both',err)
      call ceedoperatorsetnumviewtabs(op_all,1,err)
      call ceedoperatorview(op_all,err)
      call done(err,'ceedoperatorview')

! A coarse level: linear elements
      call ceedvectorcreate(ceed,nu,mult,err)
      call ceedvectorsetvalue(mult,1.d0,err)
      call ceedelemrestrictioncreate(ceed,nelem,2,1,1,nx,ceed_mem_host,ceed_copy_values,cind,rcoarse,err)
      call ceedbasiscreatetensorh1lagrange(ceed,1,1,2,q,ceed_gauss,blin,err)
      call ceedvectordestroy(x,err)
      call ceedvectorcreate(ceed,nx,x,err)
      call ceedvectorsetvalue(x,1.d0,err)
      call ceedvectordestroy(z,err)
      call ceedvectorcreate(ceed,nx,z,err)
      ctof=[1.d0,0.d0,0.5d0,0.5d0,0.d0,1.d0]
      do i=1,3
        if (i==1) call ceedoperatormultigridlevelcreate(op_name,mult,rcoarse,blin,op_c,op_p,op_r,err)
        if (i==2) call ceedoperatormultigridlevelcreatetensorh1(op_name,mult,rcoarse,blin,ctof,op_c,op_p,op_r,err)
        if (i==3) call ceedoperatormultigridlevelcreateh1(op_name,mult,rcoarse,blin,ctof,op_c,op_p,op_r,err)
        call done(err,'ceedoperatormultigridlevelcreate')
        call ceedoperatorapply(op_c,x,z,ceed_request_immediate,err)
        call vector_sum(z,nx,total)
        call expect(total,1.d0,'mass of the coarse level')
        call ceedoperatorapply(op_p,x,v,ceed_request_immediate,err)
        call vector_sum(v,nu,total)
        call expect(total,1.d0*nu,'prolongation of ones')
        call ceedoperatordestroy(op_c,err)
        call ceedoperatordestroy(op_p,err)
        call ceedoperatordestroy(op_r,err)
      enddo
      call ceedoperatorcreatefdmelementinverse(op_name,op_inv,ceed_request_immediate,err)
      call done(err,'ceedoperatorcreatefdmelementinverse')
      call ceedoperatorapply(op_inv,u,v,ceed_request_immediate,err)
      call done(err,'the inverse')

! Errors come back
      call ceedqfunctioncreateinterior(ceed,1,fails,'program.f90:fails',qf_bad,err)
      call ceedqfunctionaddinput(qf_bad,'u',1,ceed_eval_none,err)
      call ceedqfunctionaddoutput(qf_bad,'v',1,ceed_eval_none,err)
      do i=2,16
        write(arg,'(a,i0)') 'v',i
        call ceedqfunctionaddoutput(qf_bad,arg,1,ceed_eval_none,err)
        call done(err,'an output of sixteen')
      enddo
      call ceedqfunctionaddoutput(qf_bad,'v17',1,ceed_eval_none,err)
      if (err==0) stop 11
      call ceedqfunctionapply(qf_bad,3,y,n,n,n,n,n,n,n,n,n,n,n,n,n,n,n,y,n,n,n,n,n,n,n,n,n,n,n,n,n,n,n,err)
      if (err==0) stop 12
      call ceedoperatorapply(999,u,v,ceed_request_immediate,err)
      if (err==0) stop 13

      call ceedoperatordestroy(op_inv,err)
      call ceedoperatordestroy(op_all,err)
      call ceedoperatordestroy(op_name,err)
      call ceedoperatordestroy(op_mass,err)
      call ceedoperatordestroy(op_setup,err)
      call ceedqfunctiondestroy(qf_bad,err)
      call ceedqfunctiondestroy(qf_name,err)
      call ceedqfunctiondestroy(qf_id,err)
      call ceedqfunctiondestroy(qf_mass,err)
      call ceedqfunctiondestroy(qf_setup,err)
      call ceedqfunctioncontextdestroy(ctx,err)
      call done(err,'ceedqfunctioncontextdestroy')
      call ceedbasisdestroy(bx,err)
      call ceedbasisdestroy(bu,err)
      call ceedbasisdestroy(bh1,err)
      call ceedbasisdestroy(bdiv,err)
      call ceedbasisdestroy(bcurl,err)
      call ceedbasisdestroy(bt,err)
      call ceedbasisdestroy(blin,err)
      call done(err,'ceedbasisdestroy')
      call ceeddestroy(ceed,err)
      call done(err,'ceeddestroy')
      write(*,*) 'all is well'
      end

      subroutine set_entry(a,offset,i,value)
      real*8 a(*),value
      integer*8 offset
      integer i
      a(i+offset)=value
      end

      subroutine vector_sum(vec,n,total)
      include 'ceed/fortran.h'
      integer vec,n,err,i
      integer*8 offset
      real*8 total,a(1)
      call ceedvectorgetarrayread(vec,ceed_mem_host,a,offset,err)
      call done(err,'ceedvectorgetarrayread')
      call add_up(a,offset,n,total)
      call ceedvectorrestorearrayread(vec,a,offset,err)
      end

      subroutine add_up(a,offset,n,total)
      real*8 a(*),total
      integer*8 offset
      integer n,i
      total=0
      do i=1,n
        total=total+a(i+offset)
      enddo
      end
